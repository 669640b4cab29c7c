"""Gear units in the exchange format REXS (FVA's Reusable Engineering Exchange Standard): export and import.

rexs_document   reading and writing of files in JSON and XML
unit_export     conversion of a train to REXS
unit_import     conversion of REXS to the declaration of a train
"""

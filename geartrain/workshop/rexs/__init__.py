"""Gear units in the exchange format REXS (FVA's Reusable Engineering Exchange Standard): export and import.

rexs_document   files in JSON and XML
unit_export     train to REXS
unit_import     REXS to the declaration of a train
"""

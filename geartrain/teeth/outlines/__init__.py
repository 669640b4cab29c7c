"""The closed outline of a toothed wheel, as a cutter would leave it: flanks, fillets, tips, rim."""

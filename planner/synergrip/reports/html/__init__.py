"""The report: one file that opens in a browser, without a network."""

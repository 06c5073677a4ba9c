"""Any text that a user writes, TOML, JSON or CSV, with the place of every value in it."""

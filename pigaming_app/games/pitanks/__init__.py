"""PiTanks: hit, and don't get hit."""

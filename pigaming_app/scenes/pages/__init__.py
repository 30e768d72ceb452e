"""The bases of pages: what all of them share, pages of rows, the entry of a name."""

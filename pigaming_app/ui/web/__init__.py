"""Servers of this computer for devices on its network: guarded, one line a refusal; and HTML, escaped in one place."""

PORT = 8788  # of the pages, TCP; 8787 is that of phones

"""Pages in a browser: a guarded server, and HTML whose texts are escaped in one place."""

PORT = 8788  # of TCP; 8787 is that of phones

"""Pages in a browser: a guarded server, and HTML whose texts are escaped in one place."""

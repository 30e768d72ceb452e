"""The event in a browser: a page for everybody, and the operator's desk."""

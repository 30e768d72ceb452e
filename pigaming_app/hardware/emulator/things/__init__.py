"""Real things on the emulated mat: boxes, cups, books, tape; their geometry and their look in the camera."""

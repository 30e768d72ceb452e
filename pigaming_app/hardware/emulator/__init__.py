"""Emulator of everything outside the computer: mat, robots, camera, projector, radio. Start reading at `arena`."""

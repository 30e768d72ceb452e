"""What stands outside the computer, emulated: mat, robots, camera, projector, radio. `arena` is where to begin."""

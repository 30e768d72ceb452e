"""What people see, hear and press: the only place that knows pygame."""

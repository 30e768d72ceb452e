"""The network that learns in the Lab, in a process of its own."""

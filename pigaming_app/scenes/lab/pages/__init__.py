"""Pages over the Lab."""

"""Awards: what each player did best."""

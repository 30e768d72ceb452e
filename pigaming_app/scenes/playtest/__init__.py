"""Play tests: matches of people who agree that their inputs are kept, to fit the models of people to them."""

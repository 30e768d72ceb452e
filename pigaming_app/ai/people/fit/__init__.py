"""The traits of a person, found from a replay: inputs, wishes of models in the same situations, and a regression."""

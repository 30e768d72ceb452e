"""What an operator changes in the file of an event, a word each."""

"""Arena number, radios and kinds of the real robots."""

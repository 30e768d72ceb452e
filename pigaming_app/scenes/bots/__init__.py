"""The field for programs of others: who may watch it, and who plays."""

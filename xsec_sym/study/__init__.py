"""How right and how fast each way to compute a quantity is, where it fails, and charts of all that."""

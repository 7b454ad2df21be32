"""The methods, a module for each family of quantities. Each has `FIELDS`: quantities, with all that computes them."""

"""What is right: arbitrary-precision values from the definition, or by a route that no kernel and no method takes."""

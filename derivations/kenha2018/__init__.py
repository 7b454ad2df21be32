"""kenha2018: a distribution of normals made from a mirror of revolution."""

"""Pages: one per design with a 3D view, and the report of the study."""

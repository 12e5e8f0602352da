"""One chart flattened to the plane, with no face mirrored."""

"""Charts glued along their seams to fewer."""

"""A surface divided into few discs that flatten well."""

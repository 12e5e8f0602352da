"""Many scans, a process each: by a cluster that others run, or one after another."""

"""What a command does, from end to end: the stages put together."""

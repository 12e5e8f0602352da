"""The smallest input of every fault that was found: a file each, named for what went wrong."""

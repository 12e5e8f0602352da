"""Charts that go around: rings for vases, bottles and limbs, and caps for their ends."""

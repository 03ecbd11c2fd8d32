"""The Suslov problem: general, without a field, and with the constraint along a principal axis."""

"""Polynya beside theory, experiments and papers: what is compared, how it is measured, what is written about it.

A comparison is a file tests/validation/NAME.toml, its result docs/validation/NAME.json, all results together
docs/validation.md. Nothing in these two is written by hand.
"""

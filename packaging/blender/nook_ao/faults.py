"""Errors that a user can correct. The add-on shows their text unchanged."""


class Fault(Exception):
    """An error whose text says what is wrong, what was found, and what is needed."""

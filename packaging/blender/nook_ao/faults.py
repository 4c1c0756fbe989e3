"""What a user can mend: its text is shown as it is."""


class Fault(Exception):
    """Says what is wrong, what came, and what is needed."""

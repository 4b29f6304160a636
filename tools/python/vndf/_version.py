"""The version of the C library that this package is for."""

__version__ = "0.1.0"

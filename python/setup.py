"""Declares the extension module, which pyproject.toml cannot."""

from setuptools import setup

setup(cffi_modules=["recto/_build.py:make_builder"])

# python/local.mk - the Python package, which is built by its own tools:
# tests/test_python.sh does it for `make check`.
EXTRA_DIST += %D%/README.md %D%/pyproject.toml %D%/setup.py \
  %D%/recto/__init__.py %D%/recto/_build.py %D%/recto/_drawing.py \
  %D%/recto/_library.py %D%/recto/_options.py %D%/recto/_recto.pyi \
  %D%/recto/_scene.py \
  %D%/recto/py.typed %D%/tests/test_recto.py \
  examples/python/faces.py examples/python/hides.py \
  examples/python/turntable.py

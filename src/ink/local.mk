# src/ink/local.mk - the sources of this layer.

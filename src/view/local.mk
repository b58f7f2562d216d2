# src/view/local.mk - the sources of this layer.

# src/scene/local.mk - the sources of this layer.

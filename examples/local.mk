# examples/local.mk - example models and what makes them.

# backends/local.mk - one writer per format.

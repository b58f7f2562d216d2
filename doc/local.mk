# doc/local.mk - the man page and the documents that go with a release.

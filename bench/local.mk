# bench/local.mk - make bench and make chart.

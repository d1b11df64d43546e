"""The claims of Tsiamis, Oliva, Calvano (2018), each judged by the numbers of the study."""

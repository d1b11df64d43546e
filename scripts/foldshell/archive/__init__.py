"""A study as an archive: a BagIt bag around a Workflow Run RO-Crate, checked on its own."""

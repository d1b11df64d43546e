"""The floor: error sentences, whole files, hashes, manifests, mesh files of any format."""

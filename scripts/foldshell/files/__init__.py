"""Floor of all rooms: error sentences, whole files, hashes and manifests, mesh files of any format."""

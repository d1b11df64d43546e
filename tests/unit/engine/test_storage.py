"""Whether a storage answers, by servers on this machine."""

import socket

from foldshell.engine.storage import PUBLIC, describe_silence, find_endpoint


def test_the_command_line_stands_before_the_environment():
    known = {"SNAKEMAKE_STORAGE_S3_ENDPOINT_URL": "http://a:1"}
    assert find_endpoint({}, ["snakemake"]) == PUBLIC
    assert find_endpoint(known, ["snakemake"]) == "http://a:1"
    assert find_endpoint(known, ["x", "--storage-s3-endpoint-url", "http://b:2"]) == "http://b:2"
    assert find_endpoint(known, ["x", "--storage-s3-endpoint-url=http://c:3"]) == "http://c:3"


def test_a_server_that_listens_and_one_that_is_gone():
    with socket.create_server(("127.0.0.1", 0)) as server:
        url = f"http://127.0.0.1:{server.getsockname()[1]}"
        assert describe_silence(url, "s3://shells") == ""
    sentence = describe_silence(url, "s3://shells")
    assert sentence.startswith(f"the storage of s3://shells, {url}, does not answer (")
    assert "Connection refused" in sentence and "start again" in sentence
    assert "does not answer" in describe_silence("http://no.such.host.invalid", "s3://shells")
    assert "does not answer" in describe_silence("http://127.0.0.1:port", "s3://shells")

"""The files of compiled kernels are safe against processes that compile at the same time."""

from grainmodes.kernels import compiler
from grainmodes.kernels.compiler import kernel


def test_two_signatures_that_are_saved_at_once_keep_their_own_code(tmp_path, monkeypatch):
    """Both processes read the empty index; the first writes its code last."""
    one, two = (compiler._CacheFile(str(tmp_path), "kernel", "stamp") for _ in range(2))
    late = []
    with monkeypatch.context() as before:
        before.setattr(compiler._CacheFile, "_load_index", lambda self: {})
        before.setattr(one, "_save_data", lambda *code: late.append(code))
        one.save("of one", "code of one")
        two.save("of two", "code of two")
    one._save_data(*late[0])
    assert two.load("of two") == "code of two"
    assert one.load("of one") in (None, "code of one")


def test_every_kernel_has_such_files():
    assert isinstance(kernel(lambda x: x)._cache._cache_file, compiler._CacheFile)

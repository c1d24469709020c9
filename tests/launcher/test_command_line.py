"""What the entry does before anything is built: help, wrong words, set-up."""
import os
import subprocess
import sys
import tempfile
import threading
import unittest
from pathlib import Path
from unittest import mock

from launcher import Failure, build, command_line, scene, setup_packages
from launcher.commands import list_command, test_command

ROOT = Path(__file__).resolve().parents[2]


def polynya(*words: str, **options) -> subprocess.CompletedProcess:
    return subprocess.run([str(ROOT / "polynya"), *words], capture_output=True, text=True, check=False, **options)


class Words(unittest.TestCase):
    def test_that_make_no_sense_are_one_line_and_exit_code_2(self):
        for words in (["fly"], ["run"], ["run", "a", "--set", "speed"], ["run", "a", "--threads", "0"],
                      ["build", "--preset", "fastest"], ["run", "a", "--colour"]):
            result = polynya(*words)
            self.assertEqual((result.returncode, result.stdout), (2, ""), words)
            self.assertEqual(len(result.stderr.splitlines()), 1, result.stderr)

    def test_help_is_there_for_every_command(self):
        for command in ("run", "replay", "explain", "build", "test", "bench", "draw", "list", "conform", "validate", "card"):
            result = polynya(command, "--help")
            self.assertEqual((result.returncode, result.stderr), (0, ""))

    def test_entry_works_from_anywhere_and_through_a_link(self):
        with tempfile.TemporaryDirectory() as folder:
            link = Path(folder) / "polynya"
            link.symlink_to(ROOT / "polynya")
            result = subprocess.run([str(link), "list"], cwd=folder, capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_settings_are_kept_in_order(self):
        arguments = command_line.parse(["run", "a", "--set", "vehicle.speed=60", "--set", "x.y=a=b"])
        self.assertEqual(arguments.settings, ["vehicle.speed=60", "x.y=a=b"])

    def test_long_tests_come_on_top_of_the_fast_ones(self):
        self.assertIn("^fast$", test_command.ctest(command_line.parse(["test"])))
        words = test_command.ctest(command_line.parse(["test", "--long", "-R", "ice"]))
        self.assertIn("^(fast|long)$", words)
        self.assertEqual(words[-2:], ["--tests-regex", "ice"])


class Scenes(unittest.TestCase):
    def test_are_found_by_file_folder_and_name(self):
        for words in ("cases/water_exit", "cases/water_exit/scene.toml", "water_exit", str(ROOT / "cases/water_exit")):
            self.assertEqual(scene.find(words), ROOT / "cases" / "water_exit" / "scene.toml")

    def test_that_come_along_are_listed_by_a_word_that_finds_them(self):
        files = list_command.scene_files(ROOT / "cases")
        self.assertTrue(files)
        for file in files:
            self.assertEqual(scene.find(list_command.command_word(file)), file)


class Build(unittest.TestCase):
    """ninja is real, the rules are invented."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        where = mock.patch.object(build, "build_folder", lambda preset: self.folder / preset)
        where.start()
        self.addCleanup(where.stop)
        (self.folder / "release").mkdir()

    def ninja(self, command: str):
        rule = f"rule compile\n  command = {command}\nbuild program: compile\n"
        (self.folder / "release" / "build.ninja").write_text(rule)
        build.run_ninja(["program"], "release")

    def test_failure_shows_the_compilers_words_and_not_its_command(self):
        with self.assertRaises(Failure) as failed:
            self.ninja("echo 'a.cpp:3:7: error: no semicolon'; : " + "-I/a/long/path " * 40 + " -o program; exit 1")
        self.assertIn("a.cpp:3:7: error: no semicolon", str(failed.exception))
        self.assertNotIn("-I/a/long/path", str(failed.exception))

    def test_success_is_silent_and_kept_in_the_log(self):
        self.ninja("echo compiled > program")
        self.assertIn("[1/1]", (self.folder / "release" / "build.log").read_text())

    def test_two_at_a_time_wait_for_each_other(self):
        done = []
        with mock.patch.object(build, "say", done.append):
            with build.locked("release"):
                other = threading.Thread(target=lambda: build.locked("release").__enter__() and None)
                other.start()
                other.join(0.3)
                self.assertTrue(other.is_alive())
            other.join(5)
        self.assertFalse(other.is_alive())
        self.assertEqual(done, ["waiting for another build to end"])

    def test_a_moved_checkout_is_configured_anew(self):
        (self.folder / "release" / "build.ninja").touch()
        cache = self.folder / "release" / "CMakeCache.txt"
        cache.write_text("CMAKE_HOME_DIRECTORY:INTERNAL=/somewhere/else\n")
        self.assertTrue(build.needs_configuring("release"))
        self.assertFalse(cache.exists())
        cache.write_text(f"CMAKE_HOME_DIRECTORY:INTERNAL={ROOT}\n")
        self.assertFalse(build.needs_configuring("release"))


class SetUp(unittest.TestCase):
    """apt-get and dpkg-query are invented: small scripts first on PATH."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.log = self.folder / "log"
        (self.folder / "list").write_text("# tools\ng++   # compiler\n\nninja-build\n")

    def tool(self, name: str, text: str):
        path = self.folder / name
        path.write_text(f"#!/bin/sh\n{text}\n")
        path.chmod(0o755)

    def install(self, path: str | None = None, user: int = 0) -> tuple[int, str]:
        said = []
        with mock.patch.dict(os.environ, {"PATH": path or f"{self.folder}:/usr/bin:/bin"}), \
                mock.patch.object(setup_packages, "say", said.append), \
                mock.patch.object(os, "geteuid", return_value=user):
            return setup_packages.install_missing(str(self.folder / "list")), "\n".join(said)

    def test_names_are_read_without_comments(self):
        self.assertEqual(setup_packages.read_names(str(self.folder / "list")), ["g++", "ninja-build"])

    def test_installs_only_what_is_missing_and_says_so(self):
        self.tool("dpkg-query", "echo 'g++ ii '; echo 'ninja-build un '")
        self.tool("apt-get", f"echo \"$DEBIAN_FRONTEND $@\" >> {self.log}")
        status, said = self.install()
        self.assertEqual((status, said), (0, "installing 1 Debian package: ninja-build"))
        update, install = self.log.read_text().splitlines()
        self.assertTrue(update.startswith("noninteractive") and update.endswith(" update"))
        self.assertTrue(install.endswith(" install --no-install-recommends ninja-build"))

    def test_is_silent_when_nothing_is_missing(self):
        self.tool("dpkg-query", "echo 'g++ ii '; echo 'ninja-build ii '")
        self.tool("apt-get", "exit 1")
        self.assertEqual(self.install(), (0, ""))

    def test_repeats_what_apt_get_says_when_it_fails(self):
        self.tool("dpkg-query", "exit 1")
        self.tool("apt-get", "echo E: no network; exit 100")
        status, said = self.install()
        self.assertEqual(status, 1)
        self.assertIn("E: no network", said)

    def test_without_root_or_debian_there_is_one_message(self):
        self.tool("dpkg-query", "exit 1")
        self.tool("apt-get", f"touch {self.log}")
        status, said = self.install(path=str(self.folder), user=1000)
        self.assertEqual((status, len(said.splitlines())), (1, 1))
        self.assertIn("apt-get install --no-install-recommends g++ ninja-build", said)
        (self.folder / "dpkg-query").unlink()
        status, said = self.install(path=str(self.folder))
        self.assertEqual((status, len(said.splitlines())), (1, 1))
        self.assertFalse(self.log.exists())

    def test_the_real_list_names_each_package_once(self):
        names = setup_packages.read_names(str(ROOT / "packages.txt"))
        self.assertEqual(len(names), len(set(names)))

    @unittest.skipIf(sys.version_info < (3, 9), "needs the python of the entry")
    def test_what_the_entry_imports_needs_the_standard_library_only(self):
        code = "import sys; sys.path.insert(0, sys.argv[1]); from launcher import command_line, setup_packages"
        result = subprocess.run([sys.executable, "-I", "-S", "-c", code, str(ROOT)], capture_output=True, text=True,
                                check=False)
        self.assertEqual((result.returncode, result.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()

"""pip install .: the module is built by CMake, as everything else is; the libraries that it wants are the README's."""

import os
import subprocess
import sys
from pathlib import Path

import pybind11
from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext


class CMakeBuild(build_ext):
    def build_extension(self, extension):
        source, build = Path(__file__).parent.resolve(), Path(self.build_temp).resolve()
        subprocess.run(
            [
                *("cmake", "-S", source, "-B", build),
                *("-DSGTOOLS_PYTHON=ON", "-DSGTOOLS_TESTS=OFF", "-DCMAKE_BUILD_TYPE=Release"),
                f"-DPython_EXECUTABLE={sys.executable}",
                f"-Dpybind11_DIR={pybind11.get_cmake_dir()}",
            ],
            check=True,
        )
        subprocess.run(["cmake", "--build", build, "--parallel", str(os.cpu_count()), "--target", "sgtools_python"], check=True)
        built = next((build / "python" / "sgtools").glob("_core.*.so"))
        self.copy_file(str(built), self.get_ext_fullpath(extension.name))


setup(ext_modules=[Extension("sgtools._core", sources=[])], cmdclass={"build_ext": CMakeBuild})

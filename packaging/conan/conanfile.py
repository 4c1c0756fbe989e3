"""Conan 2 recipe of the library. It builds the checkout that contains it: conan create packaging/conan"""
import os
import re
import shutil

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rmdir


class NookConan(ConanFile):
    name = "nook"
    license = "MIT"
    description = "Ambient occlusion for OpenGL engines: characters, screen space, light probes, materials"
    topics = ("ambient-occlusion", "opengl", "graphics")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "gl": [True, False]}
    default_options = {"shared": False, "fPIC": True, "gl": True}
    implements = ["auto_shared_fpic"]

    @property
    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._root, "sdk", "include", "nook", "nook.h"))
        major, minor, patch, suffix = (re.search(rf'^#define NOOK_VERSION_{part} "?([^"\n]*)', text, re.M).group(1)
                                       for part in ("MAJOR", "MINOR", "PATCH", "SUFFIX"))
        self.version = f"{major}.{minor}.{patch}{suffix}"

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "NOTICE", "cmake/*", "sdk/*", "shaders/*"):
            copy(self, pattern, self._root, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def validate_build(self):
        if self.options.gl and not shutil.which("glad"):
            raise ConanInvalidConfiguration("the option gl needs the generator glad 2 (Debian: python3-glad, PyPI: glad2)")

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ("NOOK_BAKERS", "NOOK_SAMPLES", "NOOK_TESTS"):
            toolchain.cache_variables[part] = False
        toolchain.cache_variables["NOOK_GL"] = bool(self.options.gl)
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        for name in ("LICENSE", "NOTICE"):
            copy(self, name, self.source_folder, os.path.join(self.package_folder, "licenses"))
        CMake(self).install()
        # Conan generates these files for its users.
        for folder in ("cmake", "pkgconfig"):
            rmdir(self, os.path.join(self.package_folder, "lib", folder))
        rmdir(self, os.path.join(self.package_folder, "share", "doc"))

    def package_info(self):
        self.cpp_info.libs = ["nook"]
        self.cpp_info.set_property("cmake_file_name", "nook")
        self.cpp_info.set_property("cmake_target_name", "nook::nook")
        self.cpp_info.set_property("pkg_config_name", "nook")
        if not self.options.shared:
            self.cpp_info.defines = ["NOOK_STATIC"]
            if self.settings.os in ("Linux", "FreeBSD"):
                self.cpp_info.system_libs = ["m", "stdc++"]

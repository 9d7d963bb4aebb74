# Spack's recipe for MARS, for Spack 0.23 or newer (docs/installing.md says what was tried). In a clone of MARS:
#   spack repo create ~/mars-spack mars-site && mkdir -p ~/mars-spack/packages/mars
#   cp cluster/spack/package.py ~/mars-spack/packages/mars/ && spack repo add ~/mars-spack
#   spack dev-build mars@0.3.0 ^openmpi schedulers=slurm
from spack.package import *

try:  # since Spack 1.0 build systems are in the repository of packages
    from spack_repo.builtin.build_systems.cmake import CMakePackage
except ImportError:
    pass


class Mars(CMakePackage):
    """Models articulated figures, animates them by keyframes, and renders the film in parallel."""

    license("MIT")

    # Built from this clone; there is nothing to download.
    version("0.3.0")

    requires("target=x86_64:", msg="MARS is for x86-64 processors")

    variant("mpi", default=True, description="Nodes as MPI processes; without it, as threads")
    variant("videos", default=True, description="Videos, by the program ffmpeg")
    variant("exr", default=True, description="EXR files, by OpenEXR")
    variant("ocio", default=False, description="Views of an OpenColorIO config")
    variant("studio", default=True, description="mars studio, a page in a browser")
    variant("import", default=True, description="mars import of OBJ, STL and glTF files, by Assimp")
    variant("window", default=False, description="Windows on a display, by SDL")

    depends_on("c", type="build")
    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("mpi@3:", when="+mpi")
    depends_on("hwloc@2:")
    depends_on("libpng")
    depends_on("openexr@3.1.3:", when="+exr")
    depends_on("opencolorio@2.1:", when="+ocio")
    depends_on("zlib-api")
    depends_on("highway")
    depends_on("xxhash")
    depends_on("glm")
    depends_on("cli11@2:")
    depends_on("nlohmann-json@3.11:")
    depends_on("libjpeg-turbo")
    depends_on("assimp", when="+import")
    depends_on("meshoptimizer", when="+import")
    depends_on("boost@1.74:", when="+studio")
    depends_on("openssl", when="+studio")
    depends_on("ffmpeg@5:+libx264+libvpx+libopus", when="+videos", type="run")
    depends_on("sdl2@2.26:", when="+window")
    conflicts("%gcc@:10", msg="MARS is C++20")

    generator("ninja")

    def cmake_args(self):
        parts = ["mpi", "exr", "ocio", "studio", "import", "window"]
        return [self.define_from_variant("MARS_" + part.upper(), part) for part in parts] + [
            self.define("BUILD_TESTING", False)
        ]

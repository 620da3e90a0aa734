# SPDX-License-Identifier: MIT
"""Types of the module. Shapes and units are in the docstrings: help(conelight.Scene.add_mesh)."""
import os
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, Literal, SupportsIndex, TypedDict, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

__version__: str

Floats = NDArray[np.float32]
Vector3 = tuple[float, float, float]
Vector4 = tuple[float, float, float, float]
Value = Union[bool, int, float, str]
Path = Union[str, os.PathLike[str]]
Component = Literal["full", "direct", "indirect", "diffuse", "specular", "occlusion", "albedo", "normal", "depth",
                    "voxels", "emission", "shadow_map"]
AlphaMode = Literal["opaque", "mask", "blend"]
LightType = Literal["point", "spot", "directional", "rect", "disk", "sphere"]
ErrorMap = Literal["signed", "absolute", "relative", "flip", "hdr-flip"]

class Error(RuntimeError):
    kind: Literal["usage", "bad_input", "no_gl", "runtime"]

class SettingDescription(TypedDict):
    key: str
    default: Value
    range: str
    unit: str
    help: str

class Settings:
    quality: str
    def __init__(self, values: Mapping[str, Value] = {}, *, quality: str | None = None) -> None: ...
    def get(self, key: str) -> Any: ...
    def set(self, key: str, value: Value) -> None: ...
    def update(self, values: Mapping[str, Value]) -> None: ...
    def copy(self) -> Settings: ...
    def keys(self) -> list[str]: ...
    @staticmethod
    def describe(key: str) -> SettingDescription: ...
    def __getitem__(self, key: str) -> Any: ...
    def __setitem__(self, key: str, value: Value) -> None: ...
    def __contains__(self, key: str) -> bool: ...
    def __iter__(self) -> Iterator[str]: ...
    def __len__(self) -> int: ...

class Camera:
    eye: Vector3
    target: Vector3
    up: Vector3
    vfov: float
    orthographic_height: float
    near: float
    far: float
    lens_diameter: float
    focus_distance: float
    name: str
    def __init__(self, eye: ArrayLike, target: ArrayLike, up: ArrayLike = (0, 1, 0), vfov: float = 0.78539816, *,
                 near: float = 0.01, far: float = 1000.0) -> None: ...
    @staticmethod
    def from_opencv(K: ArrayLike, R: ArrayLike, t: ArrayLike, size: tuple[int, int], *,
                    pixel_center: float = 0.0) -> Camera: ...
    def to_opencv(self, size: tuple[int, int], *, pixel_center: float = 0.0
                  ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]: ...
    def positions(self, depth: ArrayLike) -> Floats: ...
    def copy(self) -> Camera: ...

class Mesh:
    @property
    def index(self) -> int: ...
    def __index__(self) -> int: ...
    @property
    def name(self) -> str: ...
    @property
    def positions(self) -> Floats: ...
    @property
    def indices(self) -> NDArray[np.uint32]: ...
    @property
    def normals(self) -> Floats | None: ...
    @property
    def uvs(self) -> Floats | None: ...
    @property
    def tangents(self) -> Floats | None: ...
    @property
    def colors(self) -> Floats | None: ...
    def replace(self, positions: ArrayLike, indices: ArrayLike, *, normals: ArrayLike | None = None,
                uvs: ArrayLike | None = None, tangents: ArrayLike | None = None, colors: ArrayLike | None = None,
                name: str = "") -> None: ...

class Material:
    @property
    def index(self) -> int: ...
    def __index__(self) -> int: ...
    name: str
    base_color: Vector4
    metallic: float
    roughness: float
    ior: float
    specular: float
    specular_color: Vector3
    emission: Vector3
    normal_scale: float
    alpha_cutoff: float
    alpha_mode: AlphaMode
    double_sided: bool
    unlit: bool
    transmission: float
    thickness: float
    attenuation_color: Vector3
    attenuation_distance: float
    coat: float
    coat_roughness: float
    coat_normal_scale: float
    sheen_color: Vector3
    sheen_roughness: float
    base_color_texture: int | None
    metallic_roughness_texture: int | None
    normal_texture: int | None
    emissive_texture: int | None
    specular_texture: int | None
    specular_color_texture: int | None
    transmission_texture: int | None
    coat_texture: int | None
    coat_roughness_texture: int | None
    coat_normal_texture: int | None
    sheen_color_texture: int | None
    sheen_roughness_texture: int | None

class Instance:
    @property
    def index(self) -> int: ...
    def __index__(self) -> int: ...
    name: str
    mesh: int
    material: int | None
    transform: Floats
    visible: bool
    voxelized: bool
    casts_shadow: bool
    dynamic: bool

class Light:
    @property
    def index(self) -> int: ...
    def __index__(self) -> int: ...
    @property
    def type(self) -> LightType: ...
    name: str
    intensity: Vector3
    position: Vector3
    direction: Vector3
    half_u: Vector3
    half_v: Vector3
    inner_angle: float
    outer_angle: float
    range: float
    enabled: bool
    casts_shadow: bool
    flux: Vector3 | None

class Clip:
    @property
    def name(self) -> str: ...
    @property
    def duration(self) -> float: ...

class Scene:
    name: str
    sky: Vector3
    def __init__(self) -> None: ...
    @staticmethod
    def load(path: Path, *, complete: bool = True, allow_outside: bool = False) -> Scene: ...
    def save(self, path: Path) -> list[str]: ...
    def add_mesh(self, positions: ArrayLike, indices: ArrayLike, *, normals: ArrayLike | None = None,
                 uvs: ArrayLike | None = None, tangents: ArrayLike | None = None, colors: ArrayLike | None = None,
                 name: str = "") -> Mesh: ...
    def add_texture(self, pixels: NDArray[np.uint8], *, srgb: bool = True,
                    wrap: Literal["repeat", "clamp", "mirror"] = "repeat",
                    filter: Literal["linear", "nearest"] = "linear", name: str = "") -> int: ...
    def add_material(self, *, name: str = ..., base_color: ArrayLike = ..., metallic: float = ...,
                     roughness: float = ..., ior: float = ..., specular: float = ..., specular_color: ArrayLike = ...,
                     emission: ArrayLike = ..., normal_scale: float = ..., alpha_cutoff: float = ...,
                     alpha_mode: AlphaMode = ..., double_sided: bool = ..., unlit: bool = ...,
                     transmission: float = ..., thickness: float = ..., attenuation_color: ArrayLike = ...,
                     attenuation_distance: float = ..., coat: float = ..., coat_roughness: float = ...,
                     coat_normal_scale: float = ..., sheen_color: ArrayLike = ..., sheen_roughness: float = ...,
                     base_color_texture: int | None = ..., metallic_roughness_texture: int | None = ...,
                     normal_texture: int | None = ..., emissive_texture: int | None = ...,
                     specular_texture: int | None = ..., specular_color_texture: int | None = ...,
                     transmission_texture: int | None = ..., coat_texture: int | None = ...,
                     coat_roughness_texture: int | None = ..., coat_normal_texture: int | None = ...,
                     sheen_color_texture: int | None = ...,
                     sheen_roughness_texture: int | None = ...) -> Material: ...
    def add_instance(self, mesh: SupportsIndex, material: SupportsIndex | None = None,
                     transform: ArrayLike | None = None, *, name: str = ..., visible: bool = ...,
                     voxelized: bool = ..., casts_shadow: bool = ..., dynamic: bool = ...) -> Instance: ...
    def add_light(self, type: LightType, *, name: str = ..., intensity: ArrayLike = ..., position: ArrayLike = ...,
                  direction: ArrayLike = ..., half_u: ArrayLike = ..., half_v: ArrayLike = ...,
                  inner_angle: float = ..., outer_angle: float = ..., range: float = ..., enabled: bool = ...,
                  casts_shadow: bool = ..., flux: ArrayLike = ...) -> Light: ...
    def remove_light(self, light: SupportsIndex) -> None: ...
    def add_camera(self, camera: Camera) -> None: ...
    def set_environment(self, picture: ArrayLike | Path | None, *, rotation: float = 0.0,
                        strength: float = 1.0) -> None: ...
    def frame_camera(self) -> Camera: ...
    def complete(self) -> None: ...
    def validate(self) -> None: ...
    def info(self) -> str: ...
    def settings(self, mode: str = "") -> Settings: ...
    def copy(self) -> Scene: ...
    def pose(self, clip: Clip | str | int, time: float) -> None: ...
    @property
    def clips(self) -> tuple[Clip, ...]: ...
    @property
    def meshes(self) -> Sequence[Mesh]: ...
    @property
    def materials(self) -> Sequence[Material]: ...
    @property
    def instances(self) -> Sequence[Instance]: ...
    @property
    def lights(self) -> Sequence[Light]: ...
    @property
    def cameras(self) -> tuple[Camera, ...]: ...
    @property
    def notes(self) -> list[str]: ...
    @property
    def bounds(self) -> tuple[Vector3, Vector3] | None: ...
    @property
    def triangle_count(self) -> int: ...

class Renderer:
    def __init__(self, device: int | None = None, *, shader_directory: str = "", debug: bool = False) -> None: ...
    def set_scene(self, scene: Scene) -> None: ...
    def render(self, scene: Scene | None, camera: Camera | None, size: tuple[int, int],
               settings: Settings | Mapping[str, Value] | None = None, *,
               components: Component | Sequence[Component] = "full", alpha: bool = False,
               profile: bool = False) -> dict[str, Floats]: ...
    @property
    def stats(self) -> dict[str, Any]: ...
    @property
    def device(self) -> str: ...

class Progress:
    @property
    def samples_done(self) -> int: ...
    @property
    def samples_planned(self) -> int: ...
    @property
    def noise(self) -> float: ...
    @property
    def seconds_left(self) -> float: ...

class Surfaces(TypedDict):
    instance: NDArray[np.int32]
    material: NDArray[np.int32]
    triangle: NDArray[np.int32]
    depth: Floats
    position: Floats
    geometric_normal: Floats
    normal: Floats
    uv: Floats
    base_color: Floats
    metallic: Floats
    roughness: Floats
    motion: Floats  # with previous_camera or previous_scene

class CameraPath:
    def __init__(self, keys: Sequence[tuple[float, Camera]]) -> None: ...
    @staticmethod
    def load(path: str) -> CameraPath: ...
    def save(self, path: str, *, overwrite: bool = False) -> None: ...
    @property
    def start(self) -> float: ...
    @property
    def end(self) -> float: ...
    @property
    def keys(self) -> list[tuple[float, Camera]]: ...
    def at(self, seconds: float) -> Camera: ...
    def frames(self, count: int) -> list[Camera]: ...

class Probes(TypedDict):
    origin: Vector3
    spacing: Vector3
    position: Floats
    active: NDArray[np.bool_]
    sh: Floats
    irradiance: Floats
    distance: Floats

class PathTracer:
    def __init__(self, scene: Scene) -> None: ...
    def render(self, camera: Camera, size: tuple[int, int], *, samples: int = 256, noise: float = 0.0,
               bounces: int | Literal["all"] = "all", seed: int = 1, filter: Literal["center", "box"] = "center",
               threads: int = 0, components: str | Sequence[str] = "full", alpha: bool = False,
               denoise: bool | Literal["own", "oidn"] = False,
               progress: Callable[[Progress], bool | None] | None = None) -> dict[str, Floats]: ...
    def surfaces(self, camera: Camera, size: tuple[int, int], *, previous_camera: Camera | None = None,
                 previous_scene: Scene | None = None) -> Surfaces: ...
    @property
    def stats(self) -> dict[str, Any]: ...

def reference(scene: Scene, camera: Camera, size: tuple[int, int], *, samples: int = 256, noise: float = 0.0,
              bounces: int | Literal["all"] = "all", seed: int = 1, filter: Literal["center", "box"] = "center",
              threads: int = 0, components: str | Sequence[str] = "full", alpha: bool = False,
              denoise: bool | Literal["own", "oidn"] = False,
              progress: Callable[[Progress], bool | None] | None = None) -> dict[str, Floats]: ...
def bake_probes(scene: Scene, *, spacing: float = 0.0, samples: int = 1024, bounces: int | Literal["all"] = "all",
                seed: int = 1, threads: int = 0, near_surfaces: bool = False,
                progress: Callable[[float], bool | None] | None = None) -> Probes: ...
def progress_bar(label: str = "", width: int = 30) -> Callable[[Progress | float], None]: ...
def compare(test: ArrayLike, reference: ArrayLike, *, halves: Iterable[ArrayLike] | None = None,
            exposure: float = 0.0, pixels_per_degree: float = 67.02, flip: bool = True,
            blocks: int = 4) -> dict[str, float]: ...
def error_map(test: ArrayLike, reference: ArrayLike, kind: ErrorMap = "signed", *, exposure: float = 0.0,
              pixels_per_degree: float = 67.02) -> Floats: ...
def save(path: Path, pictures: ArrayLike | Mapping[str, ArrayLike],
         settings: Settings | Mapping[str, Value] | None = None) -> None: ...
def read(path: Path) -> dict[str, Floats]: ...
def builtin_scenes() -> list[str]: ...
def devices() -> list[str]: ...

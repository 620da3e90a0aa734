// SPDX-License-Identifier: MIT
// Loads what `conelight bake SCENE -o DIR --lightmaps --direct` wrote, for three.js r110 and later.
//
//   const { scene, camera } = await loadLightMaps("DIR/");
//
// All light is in the maps: the scene needs no lights, and the renderer should show linear values as they are.
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { RGBELoader } from "three/addons/loaders/RGBELoader.js";

// three.js names second texture coordinates uv2, from r151 on uv1.
const SECOND = Number.parseInt(THREE.REVISION, 10) >= 151 ? "uv1" : "uv2";

function loadPicture(address) {
  return new Promise((done, failed) => {
    new RGBELoader().setDataType(THREE.FloatType).load(address, done, undefined, failed);
  });
}

function loadScene(address) {
  return new Promise((done, failed) => new GLTFLoader().load(address, done, undefined, failed));
}

// Where an object lies in its map is written into its own copy of the second coordinates.
function placed(geometry, { offset, scale }) {
  const copy = geometry.clone();
  const from = copy.getAttribute("uv1") || copy.getAttribute("uv2");
  const to = new Float32Array(2 * from.count);
  for (let i = 0; i < from.count; ++i) {
    to[2 * i] = offset[0] + scale[0] * from.getX(i);
    to[2 * i + 1] = offset[1] + scale[1] * from.getY(i);
  }
  copy.setAttribute(SECOND, new THREE.BufferAttribute(to, 2));
  return copy;
}

// Loaders of some years leave out KHR_materials_emissive_strength.
function setEmission(material, document) {
  const own = (document.materials || []).find((one) => one.name === material.name);
  const strength = own && own.extensions && own.extensions.KHR_materials_emissive_strength;
  if (strength) material.emissiveIntensity = strength.emissiveStrength;
}

export async function loadLightMaps(folder) {
  const described = await (await fetch(folder + "lightmaps.json")).json();
  const pictures = await Promise.all(described.maps.map((map) => loadPicture(folder + map.hdr)));
  for (const picture of pictures) {
    picture.flipY = false; // glTF's first row is at v = 0
    picture.generateMipmaps = false;
    picture.minFilter = picture.magFilter = THREE.LinearFilter;
    picture.channel = 1; // r151 and later: which coordinates
    picture.needsUpdate = true;
  }
  const gltf = await loadScene(folder + described.file);
  const document = gltf.parser.json;
  const lights = [];
  gltf.scene.traverse((object) => {
    if (object.isLight && described.light === "all") lights.push(object);
    if (!object.isMesh) return;
    object.material = object.material.clone();
    setEmission(object.material, document);
    const place = object.userData.lightmap;
    if (!place) return;
    object.geometry = placed(object.geometry, place);
    object.material.lightMap = pictures[place.map];
    object.material.lightMapIntensity = 1;
  });
  for (const light of lights) light.parent.remove(light);
  return { scene: gltf.scene, camera: gltf.cameras[0] };
}

// The linear picture that a camera sees: rows from the top, RGB floats.
export function renderLinear(scene, camera, width, height) {
  const renderer = new THREE.WebGLRenderer({ antialias: false });
  renderer.physicallyCorrectLights = true; // before r155; later it is always so
  renderer.toneMapping = THREE.NoToneMapping;
  renderer.setSize(width, height, false);
  camera.aspect = width / height;
  camera.updateProjectionMatrix();
  const target = new THREE.WebGLRenderTarget(width, height, { type: THREE.FloatType });
  renderer.setRenderTarget(target);
  renderer.render(scene, camera);
  const rgba = new Float32Array(4 * width * height);
  renderer.readRenderTargetPixels(target, 0, 0, width, height, rgba);
  const rgb = new Float32Array(3 * width * height);
  for (let y = 0; y < height; ++y)
    for (let x = 0; x < width; ++x)
      for (let c = 0; c < 3; ++c) rgb[3 * (y * width + x) + c] = rgba[4 * ((height - 1 - y) * width + x) + c];
  renderer.dispose();
  return rgb;
}

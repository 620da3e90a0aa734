// SPDX-License-Identifier: MIT
// The scene's textures at low resolution for compute shaders, in an sRGB format whatever they hold: what is
// sampled is linear. Layer = index of the texture in the scene.
uniform sampler2DArray surfaceArray;

// Linear rgba of a layer at uv, averaged over `footprint` (edge in uv units, 0: finest level).
vec4 sampleSurfaceArray(int layer, vec2 uv, float footprint) {
    float level = log2(max(footprint * float(textureSize(surfaceArray, 0).x), 1.0));
    return textureLod(surfaceArray, vec3(uv, float(layer)), level);
}

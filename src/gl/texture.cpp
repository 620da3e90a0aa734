// SPDX-License-Identifier: MIT
#include "gl/texture.h"

#include <algorithm>
#include <bit>

#include "base/assert.h"
#include "base/log.h"
#include "gl/gl.h"
#include "gl/storage.h"

namespace conelight::gl {
namespace {

int fullChain(const TextureDesc& desc) {
    int edge = std::max(desc.width, desc.height);
    if (desc.target == GL_TEXTURE_3D) edge = std::max(edge, desc.depth);
    int levels = 1;
    while (edge > 1) {
        edge /= 2;
        ++levels;
    }
    return levels;
}

// Bytes of one texel, of the formats this library uses.
std::size_t texelBytes(std::uint32_t format) {
    switch (format) {
        case GL_R8:
        case GL_R8UI:
        case GL_R8I:
        case GL_R8_SNORM:
            return 1;
        case GL_R16F:
        case GL_R16UI:
        case GL_R16I:
        case GL_R16:
        case GL_R16_SNORM:
        case GL_RG8:
        case GL_RG8UI:
        case GL_RG8_SNORM:
        case GL_DEPTH_COMPONENT16:
            return 2;
        case GL_RGBA8:
        case GL_SRGB8_ALPHA8:
        case GL_RGBA8_SNORM:
        case GL_RGBA8UI:
        case GL_R32UI:
        case GL_R32F:
        case GL_R32I:
        case GL_RG16F:
        case GL_RG16:
        case GL_RG16_SNORM:
        case GL_RG16UI:
        case GL_RGB10_A2:
        case GL_R11F_G11F_B10F:
        case GL_RGB9_E5:
        case GL_DEPTH_COMPONENT32F:
        case GL_DEPTH_COMPONENT24:
            return 4;
        case GL_RGBA16F:
        case GL_RGBA16:
        case GL_RGBA16_SNORM:
        case GL_RGBA16UI:
        case GL_RG32F:
        case GL_RG32UI:
            return 8;
        case GL_RGB32F:
        case GL_RGB32UI:
            return 12;  // buffer textures only
        case GL_RGBA32F:
        case GL_RGBA32UI:
        case GL_RGBA32I:
            return 16;
        default:
            break;
    }
    base::fail(ErrorKind::Runtime, "texture format 0x%x has no known size", format);
}

int unevenEdge(int texels) { return texels + (std::has_single_bit(static_cast<unsigned>(texels)) ? 1 : 0); }

// As the driver is asked for it.
TextureDesc stored(TextureDesc desc) {
    if (!desc.uneven) return desc;
    CONELIGHT_ASSERT(desc.levels == 1, "the levels of an uneven texture are of other sizes");
    // One more of what is many is little; 32 slices of 32 rows would grow by a sixteenth.
    constexpr int kMany = 32;
    desc.width = unevenEdge(desc.width);
    if (desc.height < kMany) desc.height = unevenEdge(desc.height);
    if (desc.target == GL_TEXTURE_3D && desc.depth < kMany) desc.depth = unevenEdge(desc.depth);
    return desc;
}

bool isArray(std::uint32_t target) {
    return target == GL_TEXTURE_2D_ARRAY || target == GL_TEXTURE_CUBE_MAP_ARRAY;
}

int limitOf(GLenum limit) {
    GLint value = 0;
    glGetIntegerv(limit, &value);
    return value;
}

// Sizes beyond the driver's limits are a failure the user can act on, not an error of GL.
void requireLimits(const TextureDesc& desc, const std::string& label) {
    CONELIGHT_ASSERT(desc.width > 0 && desc.height > 0 && desc.depth > 0, "a texture has at least one texel");
    const bool cube = desc.target == GL_TEXTURE_CUBE_MAP || desc.target == GL_TEXTURE_CUBE_MAP_ARRAY;
    const int edge = limitOf(desc.target == GL_TEXTURE_3D ? GL_MAX_3D_TEXTURE_SIZE
                             : cube                       ? GL_MAX_CUBE_MAP_TEXTURE_SIZE
                                                          : GL_MAX_TEXTURE_SIZE);
    const int depth = desc.target == GL_TEXTURE_3D ? edge
                      : isArray(desc.target)       ? limitOf(GL_MAX_ARRAY_TEXTURE_LAYERS)
                                                   : 1;
    if (desc.width > edge || desc.height > edge || desc.depth > depth)
        base::fail(ErrorKind::Runtime,
                   "OpenGL: texture '%s' of %d x %d x %d; at most %d x %d x %d would be right on this driver",
                   label.c_str(), desc.width, desc.height, desc.depth, edge, edge, depth);
}

}  // namespace

Texture::Texture(const TextureDesc& desc, const std::string& label) : desc_(desc) {
    if (desc_.levels == 0) desc_.levels = fullChain(desc_);
    const std::size_t bytes = storageBytes(desc_);
    const TextureDesc storage = stored(desc_);
    requireLimits(storage, label);
    requireRoom(label, bytes);
    Name created = 0;
    glCreateTextures(desc_.target, 1, &created);
    adopt(created, label, bytes);
    if (desc_.target == GL_TEXTURE_3D || isArray(desc_.target))
        glTextureStorage3D(created, desc_.levels, desc_.format, storage.width, storage.height, storage.depth);
    else
        glTextureStorage2D(created, desc_.levels, desc_.format, storage.width, storage.height);
    requireStorage(ObjectType::Texture, created, label, bytes);
}

Texture::Texture(const Buffer& buffer, std::uint32_t format, const std::string& label)
    : desc_{GL_TEXTURE_BUFFER, format, static_cast<int>(buffer.bytes() / texelBytes(format))} {
    const int limit = limitOf(GL_MAX_TEXTURE_BUFFER_SIZE);
    if (buffer.bytes() / texelBytes(format) > static_cast<std::size_t>(limit))
        base::fail(ErrorKind::Runtime,
                   "OpenGL: buffer texture '%s' of %zu texels; at most %d would be right on this driver",
                   label.c_str(), buffer.bytes() / texelBytes(format), limit);
    Name created = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &created);
    adopt(created, label, 0);
    glTextureBuffer(created, format, buffer.name());
}

int Texture::width(int level) const { return std::max(desc_.width >> level, 1); }
int Texture::height(int level) const { return std::max(desc_.height >> level, 1); }
int Texture::depth(int level) const {
    if (desc_.target == GL_TEXTURE_CUBE_MAP) return 6;
    return desc_.target == GL_TEXTURE_3D ? std::max(desc_.depth >> level, 1) : desc_.depth;
}

std::size_t Texture::storageBytes(const TextureDesc& wanted) {
    const TextureDesc desc = stored(wanted);
    std::size_t texels = 0;
    const int levels = desc.levels != 0 ? desc.levels : fullChain(desc);
    for (int level = 0; level < levels; ++level) {
        const std::size_t layers =
            desc.target == GL_TEXTURE_3D         ? static_cast<std::size_t>(std::max(desc.depth >> level, 1))
            : desc.target == GL_TEXTURE_CUBE_MAP ? 6
                                                 : static_cast<std::size_t>(desc.depth);
        texels += static_cast<std::size_t>(std::max(desc.width >> level, 1)) *
                  static_cast<std::size_t>(std::max(desc.height >> level, 1)) * layers;
    }
    return texels * texelBytes(desc.format);
}

void Texture::upload(int level, std::uint32_t layout, std::uint32_t type, const void* data) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (desc_.target == GL_TEXTURE_2D)
        glTextureSubImage2D(name(), level, 0, 0, width(level), height(level), layout, type, data);
    else
        glTextureSubImage3D(name(), level, 0, 0, 0, width(level), height(level), depth(level), layout, type,
                            data);
}

void Texture::uploadLayer(int level, int layer, std::uint32_t layout, std::uint32_t type, const void* data) {
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glTextureSubImage3D(name(), level, 0, 0, layer, width(level), height(level), 1, layout, type, data);
}

void Texture::generateMipmaps() { glGenerateTextureMipmap(name()); }

void Texture::clear(int level, std::uint32_t layout, std::uint32_t type, const void* texel) {
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glClearTexImage(name(), level, layout, type, texel);
}

void Texture::clearRegion(int level, const glm::ivec3& offset, const glm::ivec3& size, std::uint32_t layout,
                          std::uint32_t type) {
    glClearTexSubImage(name(), level, offset.x, offset.y, offset.z, size.x, size.y, size.z, layout, type,
                       nullptr);
}

void Texture::copyFrom(const Texture& source) {
    CONELIGHT_ASSERT(source.desc_.target == desc_.target && source.desc_.format == desc_.format &&
                         source.width() == width() && source.height() == height() &&
                         source.depth() == depth(),
                     "Texture::copyFrom: textures differ");
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glCopyImageSubData(source.name(), desc_.target, 0, 0, 0, 0, name(), desc_.target, 0, 0, 0, 0, width(),
                       height(), depth());
}

void Texture::copyLayers(const Texture& source, int layers) {
    CONELIGHT_ASSERT(source.desc_.target == desc_.target && source.desc_.format == desc_.format &&
                         source.width() == width() && source.height() == height() &&
                         source.desc_.levels == desc_.levels && layers <= std::min(source.depth(), depth()),
                     "Texture::copyLayers: arrays differ");
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    for (int level = 0; level < desc_.levels; ++level)
        glCopyImageSubData(source.name(), desc_.target, level, 0, 0, 0, name(), desc_.target, level, 0, 0, 0,
                           width(level), height(level), layers);
}

void Texture::copyLayer(int level, int layer, const Texture& source) {
    CONELIGHT_ASSERT(
        source.width(level) == width(level) && source.height(level) == height(level) && layer < depth(),
        "Texture::copyLayer: sizes differ");
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glCopyImageSubData(source.name(), source.desc_.target, level, 0, 0, 0, name(), desc_.target, level, 0, 0,
                       layer, width(level), height(level), 1);
}

void Texture::read(int level, std::uint32_t layout, std::uint32_t type, void* data, std::size_t bytes) const {
    if (desc_.uneven) return readRegion({0, 0, 0}, {width(), height(), depth()}, layout, type, data, bytes);
    countWait();
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureImage(name(), level, layout, type, static_cast<GLsizei>(bytes), data);
}

void Texture::readRegion(const glm::ivec3& offset, const glm::ivec3& size, std::uint32_t layout,
                         std::uint32_t type, void* data, std::size_t bytes) const {
    countWait();
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glGetTextureSubImage(name(), 0, offset.x, offset.y, offset.z, size.x, size.y, size.z, layout, type,
                         static_cast<GLsizei>(bytes), data);
}

void Texture::parameter(std::uint32_t parameterName, int value) {
    glTextureParameteri(name(), parameterName, value);
}
void Texture::bind(unsigned unit) const { glBindTextureUnit(unit, name()); }
Sampler::Sampler(const SamplerDesc& desc, const std::string& label) {
    Name name = 0;
    glCreateSamplers(1, &name);
    glSamplerParameteri(name, GL_TEXTURE_MIN_FILTER, static_cast<GLint>(desc.minFilter));
    glSamplerParameteri(name, GL_TEXTURE_MAG_FILTER, static_cast<GLint>(desc.magFilter));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_S, static_cast<GLint>(desc.wrap));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_T,
                        static_cast<GLint>(desc.wrapV != 0 ? desc.wrapV : desc.wrap));
    glSamplerParameteri(name, GL_TEXTURE_WRAP_R, static_cast<GLint>(desc.wrap));
    if (desc.maxAnisotropy > 1.0f && epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        glSamplerParameterf(name, GL_TEXTURE_MAX_ANISOTROPY_EXT, desc.maxAnisotropy);
    if (desc.depthCompare) {
        glSamplerParameteri(name, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(name, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
    adopt(name, label, 0);
}

void Sampler::bind(unsigned unit) const { glBindSampler(unit, name()); }
void bindForeignTexture(unsigned unit, Name texture) { glBindTextureUnit(unit, texture); }
void unbindSampler(unsigned unit) { glBindSampler(unit, 0); }

namespace {

int levelValue(Name texture, int level, GLenum what) {
    GLint value = 0;
    glGetTextureLevelParameteriv(texture, level, what, &value);
    return value;
}

// Whether all levels below the base level are there, which textures of changing storage may lack.
bool hasAllLevels(Name texture, int base, const TextureShape& found) {
    GLint immutable = GL_FALSE, last = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_IMMUTABLE_FORMAT, &immutable);
    if (immutable != GL_FALSE) return true;
    glGetTextureParameteriv(texture, GL_TEXTURE_MAX_LEVEL, &last);
    for (int i = 1, edge = std::max(found.width, found.height); edge >> i > 0 && base + i <= last; ++i)
        if (levelValue(texture, base + i, GL_TEXTURE_WIDTH) != std::max(found.width >> i, 1) ||
            levelValue(texture, base + i, GL_TEXTURE_HEIGHT) != std::max(found.height >> i, 1))
            return false;
    return true;
}

}  // namespace

TextureShape shapeOfForeign(Name texture) {
    TextureShape found;
    if (texture == 0 || glIsTexture(texture) == GL_FALSE) return found;
    GLint target = 0, base = 0;
    glGetTextureParameteriv(texture, GL_TEXTURE_TARGET, &target);
    if (target != GL_TEXTURE_2D) return found;
    glGetTextureParameteriv(texture, GL_TEXTURE_BASE_LEVEL, &base);
    found.width = levelValue(texture, base, GL_TEXTURE_WIDTH);
    found.height = levelValue(texture, base, GL_TEXTURE_HEIGHT);
    if (found.width < 1 || found.height < 1) return found;
    const int type = levelValue(texture, base, GL_TEXTURE_RED_TYPE);
    found.floats = type == GL_FLOAT || type == GL_UNSIGNED_NORMALIZED || type == GL_SIGNED_NORMALIZED;
    found.mipmapped = hasAllLevels(texture, base, found);
    return found;
}

void reserveTexels(Buffer& buffer, Texture& texels, std::uint32_t format, std::size_t bytes,
                   const std::string& label) {
    if (buffer && buffer.bytes() >= bytes) return;
    const bool grows = static_cast<bool>(buffer);
    texels = {};
    buffer = {};
    buffer = Buffer(grows ? bytes + bytes / 4 : bytes, label);
    texels = Texture(buffer, format, label);
}

}  // namespace conelight::gl

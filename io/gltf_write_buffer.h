// SPDX-License-Identifier: MIT
// The binary half of a glTF file that is being written: bytes, buffer views, accessors. Private to this room.
#pragma once

#include <cstdint>
#include <cstring>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <vector>

namespace conelight::io {

class GltfBuffer {
  public:
    explicit GltfBuffer(nlohmann::ordered_json& root) : root_(root) {}

    // Index of a new accessor over the vectors (N floats each). Empty gives none: -1.
    template <int N>
    int vectors(const std::vector<glm::vec<N, float>>& values, bool withBounds = false) {
        if (values.empty()) return -1;
        const int at = accessor(values.data(), values.size() * sizeof(values[0]), values.size(), 5126,
                                N == 2   ? "VEC2"
                                : N == 3 ? "VEC3"
                                         : "VEC4",
                                34962);
        if (withBounds) {
            glm::vec<N, float> low = values[0], high = values[0];
            for (const auto& v : values) {
                low = glm::min(low, v);
                high = glm::max(high, v);
            }
            for (int i = 0; i < N; ++i) {
                root_["accessors"][static_cast<std::size_t>(at)]["min"].push_back(low[i]);
                root_["accessors"][static_cast<std::size_t>(at)]["max"].push_back(high[i]);
            }
        }
        return at;
    }
    int indices(const std::vector<std::uint32_t>& values) {
        return accessor(values.data(), values.size() * sizeof(values[0]), values.size(), 5125, "SCALAR",
                        34963);
    }
    // Index of a new buffer view over bytes that are no accessor (pictures).
    int view(const void* data, std::size_t size, int target = 0) {
        while (bytes_.size() % 4 != 0) bytes_.push_back(0);
        nlohmann::ordered_json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
        if (target != 0) view["target"] = target;
        const std::size_t at = bytes_.size();
        bytes_.resize(at + size);
        std::memcpy(bytes_.data() + at, data, size);
        root_["bufferViews"].push_back(view);
        return static_cast<int>(root_["bufferViews"].size()) - 1;
    }
    std::vector<std::uint8_t>& bytes() { return bytes_; }

  private:
    int accessor(const void* data, std::size_t size, std::size_t count, int componentType, const char* type,
                 int target) {
        const int at = view(data, size, target);
        root_["accessors"].push_back(
            {{"bufferView", at}, {"componentType", componentType}, {"count", count}, {"type", type}});
        return static_cast<int>(root_["accessors"].size()) - 1;
    }

    nlohmann::ordered_json& root_;
    std::vector<std::uint8_t> bytes_;
};

}  // namespace conelight::io

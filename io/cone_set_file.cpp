// SPDX-License-Identifier: MIT
#include "io/cone_set_file.h"

#include <fmt/core.h>

#include "conelight/error.h"
#include "io/files.h"
#include "io/json_file.h"

namespace conelight::io {
namespace {

using Json = nlohmann::ordered_json;

float numberAt(const JsonFile& file, const Json& cone, const std::string& pointer, const char* key) {
    const auto found = cone.find(key);
    if (found == cone.end() || !found->is_number())
        file.fail(pointer + "/" + key, fmt::format("'{}' of a cone is a number", key));
    return found->get<float>();
}

glm::vec3 directionAt(const JsonFile& file, const Json& cone, const std::string& pointer) {
    const auto found = cone.find("direction");
    const bool fits = found != cone.end() && found->is_array() && found->size() == 3 &&
                      (*found)[0].is_number() && (*found)[1].is_number() && (*found)[2].is_number();
    if (!fits) file.fail(pointer + "/direction", "'direction' of a cone is three numbers, as in [0, 0, 1]");
    return {(*found)[0].get<float>(), (*found)[1].get<float>(), (*found)[2].get<float>()};
}

void refuseOtherKeys(const JsonFile& file, const Json& cone, const std::string& pointer) {
    for (const auto& [key, value] : cone.items())
        if (key != "direction" && key != "aperture" && key != "weight")
            file.fail(
                pointer + "/" + key,
                fmt::format("a cone has no '{}'; direction, aperture, weight would be right", oneLine(key)));
}

}  // namespace

std::vector<SetCone> readConeSet(const std::string& path) {
    const JsonFile file(path);
    const Json& root = file.root();
    const auto list = root.is_object() ? root.find("cones") : root.end();
    if (!root.is_object() || list == root.end() || !list->is_array())
        file.fail("", "a cone set is an object with a list 'cones'");
    if (list->empty()) file.fail("/cones", "a cone set has 1 to 64 cones");
    std::vector<SetCone> cones;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const std::string pointer = fmt::format("/cones/{}", i);
        const Json& cone = (*list)[i];
        if (!cone.is_object()) file.fail(pointer, "a cone is an object with direction, aperture, weight");
        refuseOtherKeys(file, cone, pointer);
        cones.push_back({directionAt(file, cone, pointer), numberAt(file, cone, pointer, "aperture"),
                         numberAt(file, cone, pointer, "weight")});
    }
    Settings settings;
    settings.cones.diffuseSet = DiffuseSet::Own;
    settings.cones.ownSet = cones;
    try {
        validateSettings(settings);
    } catch (const Error& error) {
        throw Error(ErrorKind::BadInput, fmt::format("{}: {}", path, error.what()));
    }
    return cones;
}

void writeConeSet(const std::string& path, const std::vector<SetCone>& cones) {
    Json list = Json::array();
    const auto rounded = [](float value) { return std::stod(fmt::format("{:.6g}", value)); };
    for (const SetCone& cone : cones)
        list.push_back(
            {{"direction", {rounded(cone.direction.x), rounded(cone.direction.y), rounded(cone.direction.z)}},
             {"aperture", rounded(cone.aperture)},
             {"weight", rounded(cone.weight)}});
    const std::string text = Json{{"cones", std::move(list)}}.dump(2) + "\n";
    writeFile(path, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

}  // namespace conelight::io

// SPDX-License-Identifier: MIT
#include "support/program.h"

#include <algorithm>
#include <fstream>
#include <sstream>

#include "conelight/error.h"
#include "io/image_file.h"

namespace conelight::test {

std::string scratchPath(const std::string& name) { return scratchDir() + "/" + name; }

CommandResult conelight(const std::string& arguments, const std::string& environment) {
    return runCommand(environment + " '" + CONELIGHT_PROGRAM + "' " + arguments);
}

std::string bytesOf(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::vector<float> pixelsOf(const std::string& picture) {
    try {
        io::FloatImage image = io::readImage(picture);
        std::vector<float> values = std::move(image.pixels);
        for (const io::ImageLayer& layer : image.layers)
            values.insert(values.end(), layer.pixels.begin(), layer.pixels.end());
        return values;
    } catch (const Error& error) {
        ADD_FAILURE() << error.what();
        return {};
    }
}

void expectOneLine(const CommandResult& result, int status, const std::string& part) {
    EXPECT_EQ(result.status, status) << result.output;
    EXPECT_EQ(std::count(result.output.begin(), result.output.end(), '\n'), 1) << result.output;
    EXPECT_EQ(result.output.rfind("conelight: ", 0), 0u) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
}

}  // namespace conelight::test

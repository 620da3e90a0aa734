// SPDX-License-Identifier: MIT
// What a driver's compiler makes of compute shaders, on a device that need not exist: tools/gpu_isa builds and runs it.
//
// Standard input, a kernel a line: FILE.spv, then its bindings, BINDING:VkDescriptorType each. Standard output: the device's
// name; then a JSON object a kernel, statistic -> number, `{}` for one that the compiler refuses.
#include <vulkan/vulkan.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace {

template <class T>
T made(VkStructureType type) {
    T value{};
    value.sType = type;
    return value;
}

void require(bool done, const char* what) {
    if (done) return;
    std::fprintf(stderr, "gpu_isa: %s\n", what);
    std::exit(1);
}

struct Device {
    VkInstance instance{};
    VkPhysicalDevice physical{};
    VkDevice device{};
};

// The first device, with what tells of pipelines.
Device openDevice() {
    Device d;
    auto application = made<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
    application.apiVersion = VK_API_VERSION_1_1;
    auto instance = made<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
    instance.pApplicationInfo = &application;
    require(vkCreateInstance(&instance, nullptr, &d.instance) == VK_SUCCESS, "no Vulkan");
    std::uint32_t count = 1;
    const VkResult listed = vkEnumeratePhysicalDevices(d.instance, &count, &d.physical);
    require((listed == VK_SUCCESS || listed == VK_INCOMPLETE) && count == 1, "no device");
    auto tells = made<VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR>(
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR);
    auto features = made<VkPhysicalDeviceFeatures2>(VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2);
    features.pNext = &tells;
    vkGetPhysicalDeviceFeatures2(d.physical, &features);
    require(tells.pipelineExecutableInfo == VK_TRUE, "the device does not tell what it makes of pipelines");
    const float priority = 1;
    auto queue = made<VkDeviceQueueCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO);
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    const char* extension = VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME;
    auto create = made<VkDeviceCreateInfo>(VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO);
    create.pNext = &features;
    create.queueCreateInfoCount = 1;
    create.pQueueCreateInfos = &queue;
    create.enabledExtensionCount = 1;
    create.ppEnabledExtensionNames = &extension;
    require(vkCreateDevice(d.physical, &create, nullptr, &d.device) == VK_SUCCESS, "no device can be made");
    return d;
}

std::vector<char> bytesOf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

VkPipelineLayout layoutOf(VkDevice device, std::istream& bindings) {
    std::vector<VkDescriptorSetLayoutBinding> all;
    int binding = 0, type = 0;
    for (char colon; bindings >> binding >> colon >> type;)
        all.push_back({static_cast<std::uint32_t>(binding), static_cast<VkDescriptorType>(type), 1,
                       VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    auto set = made<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    set.bindingCount = static_cast<std::uint32_t>(all.size());
    set.pBindings = all.data();
    VkDescriptorSetLayout setLayout{};
    require(vkCreateDescriptorSetLayout(device, &set, nullptr, &setLayout) == VK_SUCCESS, "no descriptors");
    auto create = made<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    create.setLayoutCount = 1;
    create.pSetLayouts = &setLayout;
    VkPipelineLayout layout{};
    require(vkCreatePipelineLayout(device, &create, nullptr, &layout) == VK_SUCCESS, "no layout");
    return layout;
}

double numberOf(const VkPipelineExecutableStatisticKHR& s) {
    switch (s.format) {
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_BOOL32_KHR:
            return s.value.b32;
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR:
            return static_cast<double>(s.value.i64);
        case VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR:
            return static_cast<double>(s.value.u64);
        default:
            return s.value.f64;
    }
}

void printStatistics(VkDevice device, VkPipeline pipeline) {
    auto info = made<VkPipelineExecutableInfoKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR);
    info.pipeline = pipeline;
    const auto get = reinterpret_cast<PFN_vkGetPipelineExecutableStatisticsKHR>(
        vkGetDeviceProcAddr(device, "vkGetPipelineExecutableStatisticsKHR"));
    std::uint32_t count = 0;
    get(device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> all(
        count, made<VkPipelineExecutableStatisticKHR>(VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR));
    get(device, &info, &count, all.data());
    const char* separator = "{";
    for (const VkPipelineExecutableStatisticKHR& s : all) {
        std::printf("%s\"%s\": %g", separator, s.name, numberOf(s));
        separator = ", ";
    }
    std::puts(all.empty() ? "{}" : "}");
    std::fflush(stdout);
}

}  // namespace

int main() {
    const Device d = openDevice();
    VkPhysicalDeviceProperties properties{};
    vkGetPhysicalDeviceProperties(d.physical, &properties);
    std::puts(properties.deviceName);
    for (std::string line; std::getline(std::cin, line);) {
        std::istringstream words(line);
        std::string file;
        words >> file;
        const std::vector<char> code = bytesOf(file);
        auto module = made<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
        module.codeSize = code.size();
        module.pCode = reinterpret_cast<const std::uint32_t*>(code.data());
        auto create = made<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
        create.flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR;
        create.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
        create.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
        create.stage.pName = "main";
        create.layout = layoutOf(d.device, words);
        VkPipeline pipeline{};
        const bool compiles =
            vkCreateShaderModule(d.device, &module, nullptr, &create.stage.module) == VK_SUCCESS &&
            vkCreateComputePipelines(d.device, VK_NULL_HANDLE, 1, &create, nullptr, &pipeline) == VK_SUCCESS;
        if (compiles)
            printStatistics(d.device, pipeline);
        else
            std::puts("{}");
    }
}

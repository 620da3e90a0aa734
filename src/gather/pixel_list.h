// SPDX-License-Identifier: MIT
// A pass over the pixels of a list on the GPU, which begins with the three counts of groups of an indirect dispatch,
// the number of pixels, and the first row of groups that the dispatch is of (LobeList, VisibilityList). In parts the
// rows of groups are counted here, and dispatched some at a time.
//
// Readers need the barriers of the pass. GL state changed: program and its slots, the indirect dispatch buffer binding.
#pragma once

#include "base/steps.h"
#include "gl/pace.h"

namespace conelight::gather {

struct ListedPass {
    const char* name;
    const gl::ProgramDesc& desc;
    const gl::Inputs& inputs;
    gl::Buffer& list;
};

// `pass` is copied; what it refers to has to live until this is done.
base::Steps dispatchListed(const gl::Device& device, ListedPass pass);

}  // namespace conelight::gather

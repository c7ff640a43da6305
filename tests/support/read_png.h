#pragma once

#include <filesystem>

#include "antigrasp/render/image.h"

namespace antigrasp {

// InputError unless the file is a PNG image. Grey and transparent ones become RGB on white.
Image ReadPng(const std::filesystem::path& path);

}  // namespace antigrasp

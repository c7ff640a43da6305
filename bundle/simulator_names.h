#pragma once

#include <string>
#include <string_view>

namespace antigrasp {

// Names that formats accept, the same for the same name; two names may become one.

// A body or link: MuJoCo and SDFormat keep "world" for themselves, SDFormat "__...__" too and "::"
// for scopes, also where it reads URDF: "a::b" -> "a_b", "world" -> "world_object".
std::string LinkName(std::string_view name);

// A USD prim: letters, digits and _, no digit first: "3-way mug" -> "_3_way_mug".
std::string UsdName(std::string_view name);

}  // namespace antigrasp

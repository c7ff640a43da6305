#pragma once

#include <vector>

#include "antigrasp/datasets/hdf5_handle.h"

// Only for .cpp files of this folder: nobody else sees HDF5.
namespace antigrasp {

// Whether the chunk of an item of numbers, where every item is one, is in the file and was stored
// through the dataset's filters. The index of chunks is the part of a file that has no check sum:
// damaged, it can leave a chunk out, which would be zeros, claim gigabytes for it, or pass a filter
// by, and then the library copies more than it has read. Logarithmic in the number of items, and as
// much to read as the item itself; without filters, as no file of ours is, linear in that number.
bool ItemIsStored(const Hdf5Handle& dataset, const std::vector<hsize_t>& start,
                  const std::vector<hsize_t>& extents);

}  // namespace antigrasp

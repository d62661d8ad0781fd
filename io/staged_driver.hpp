#pragma once
/// HDF5 file driver that makes one open-write-close session all or nothing.
///
/// Stock HDF5 overwrites indices in place while it works. A full disk then leaves a superblock that
/// points past the end of the file, and a kill in the middle of a B-tree split loses frames that
/// were finished long ago. Here bytes past the old end of the file go straight to disk (nothing
/// points at them yet), while changes of older bytes wait in memory; at flush or close they are
/// written down in a journal beside the file and then put in place in one short burst. A kill in
/// that burst costs nothing: the next open takes them from the journal. A session that fails or is
/// abandoned is cut back to the old length: the file is then what it was before, byte for byte.
///
/// Every page of a file with checksums is checked before HDF5 gets its bytes.

#include <hdf5.h>

#include <string>

namespace acinus::io::h5 {

/// Outcome of one session, owned by the caller, which keeps it alive until the file is closed.
struct StagedState {
  int error = 0;         ///< errno of the first failed write, 0 = none
  int read_error = 0;    ///< of the last failed read; EBADMSG: other bytes than were written
  bool discard = false;  ///< set by the caller or by a failure: nothing more is written, close
                         ///< restores the file
};

/// Makes a file access property list use the staged driver.
/// @param access  H5P_FILE_ACCESS list
/// @param sums    a file that is made with it gets checksums of its pages, see page_sums.hpp
/// @return        negative when HDF5 refuses
herr_t use_staged_driver(hid_t access, StagedState* state, bool sums);

}  // namespace acinus::io::h5

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkWritersTogether
 * @brief   runs writers side by side, for scripts: what takes long in them is to compress
 *
 * Each writes data of its own, to a file of its own or to its output string.
 */
#ifndef vtkWritersTogether_h
#define vtkWritersTogether_h

#include "vtkObject.h"
#include "vtkWaftFiltersModule.h"

class vtkCollection;

class VTKWAFTFILTERS_EXPORT vtkWritersTogether : public vtkObject
{
public:
  static vtkWritersTogether* New();
  vtkTypeMacro(vtkWritersTogether, vtkObject);

  /** How many are worth giving to Write at once. */
  static int GetNumberOfThreads();
  /** Calls Write of each vtkXMLWriter of a collection, in any order; others are passed over. */
  static void Write(vtkCollection* writers);

protected:
  vtkWritersTogether() = default;
  ~vtkWritersTogether() override = default;

private:
  vtkWritersTogether(const vtkWritersTogether&) = delete;
  void operator=(const vtkWritersTogether&) = delete;
};

#endif

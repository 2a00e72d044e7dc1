// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkSharedWork
 * @brief   work of one MPI process that others do a part of
 *
 * Of a program of several processes the first runs its stages; those that have its controller
 * (SetController) divide their work over all. The others call Serve meanwhile: they need neither
 * stages nor data of their own. What comes out has the same bytes for any number of processes.
 */
#ifndef vtkSharedWork_h
#define vtkSharedWork_h

#include "vtkObject.h"
#include "vtkWaftSourcesModule.h"

class vtkMultiProcessController;

class VTKWAFTSOURCES_EXPORT vtkSharedWork : public vtkObject
{
public:
  static vtkSharedWork* New();
  vtkTypeMacro(vtkSharedWork, vtkObject);

  /** Works for the first process, on each of the others, until that calls Release. */
  static void Serve(vtkMultiProcessController* controller);
  /** On the first: how many processes of its machine are one run, itself among them (1). It takes
   *  the threads of the others, as many each as its own, while they have no work of it. */
  static void SetProcessesHere(int count);
  /** Lets the others go, on the first. */
  static void Release(vtkMultiProcessController* controller);

protected:
  vtkSharedWork() = default;
  ~vtkSharedWork() override = default;

private:
  vtkSharedWork(const vtkSharedWork&) = delete;
  void operator=(const vtkSharedWork&) = delete;
};

#endif

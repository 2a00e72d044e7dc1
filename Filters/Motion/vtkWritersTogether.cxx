// SPDX-License-Identifier: BSD-3-Clause
#include "vtkWritersTogether.h"

#include "Bridge/Pipeline/StageExecution.h"

#include <vtkCollection.h>
#include <vtkObjectFactory.h>
#include <vtkSMPTools.h>
#include <vtkXMLWriter.h>

#include <vector>

vtkStandardNewMacro(vtkWritersTogether);

int vtkWritersTogether::GetNumberOfThreads()
{
  waft::SmpFor(); // chooses the backend
  return vtkSMPTools::GetEstimatedNumberOfThreads();
}

void vtkWritersTogether::Write(vtkCollection* writers)
{
  std::vector<vtkXMLWriter*> each;
  for (int i = 0; i < writers->GetNumberOfItems(); ++i)
  {
    if (auto* writer = vtkXMLWriter::SafeDownCast(writers->GetItemAsObject(i)))
    {
      each.push_back(writer);
    }
  }
  waft::SmpFor()(each.size(),
                 [&](std::size_t begin, std::size_t end)
                 {
                   for (std::size_t i = begin; i < end; ++i)
                   {
                     each[i]->Write();
                   }
                 });
}

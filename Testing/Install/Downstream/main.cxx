// SPDX-License-Identifier: BSD-3-Clause
// Exit status 0 when a source of the installed library gives what was asked for.
#include <vtkNew.h>
#include <vtkObjectSource.h>
#include <vtkPolyData.h>

int main()
{
  vtkNew<vtkObjectSource> source;
  source->SetPosition(0.25, -0.5, 1.75);
  source->Update();
  double point[3];
  if (source->GetOutput()->GetNumberOfPoints() != 1)
  {
    return 1;
  }
  source->GetOutput()->GetPoint(0, point);
  return point[0] == 0.25 && point[1] == -0.5 && point[2] == 1.75 ? 0 : 2;
}

// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkStreamlineTubes
 * @brief   lines along the vectors of a field, as tubes that thicken the way these point
 *
 * The lines begin at places spread evenly over the bounds (the additive recurrence of the plastic
 * number, Roberts 2018), the same ones whatever the field, so that lines do not jump from frame to
 * frame. The vectors are those of the first point array of three components that is there of
 * Velocity and Wind, or else the active vectors. Without any, or without data, there are no lines.
 */
#ifndef vtkStreamlineTubes_h
#define vtkStreamlineTubes_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkWaftProxiesModule.h"

class vtkDataSet;

class VTKWAFTPROXIES_EXPORT vtkStreamlineTubes : public vtkPolyDataAlgorithm
{
public:
  static vtkStreamlineTubes* New();
  vtkTypeMacro(vtkStreamlineTubes, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /** Number of lines, 0 to 100,000; default: 200. */
  vtkSetClampMacro(NumberOfLines, int, 0, 100000);
  vtkGetMacro(NumberOfLines, int);
  ///@}

  ///@{
  /** Length of a line over the diagonal of the data, 0 to 10; default: 0.2. */
  vtkSetClampMacro(LineLength, double, 0.0, 10.0);
  vtkGetMacro(LineLength, double);
  ///@}

  ///@{
  /** Radius of a tube where it is thickest, over the diagonal of the data, 0 to 0.1; default:
   * 0.005. */
  vtkSetClampMacro(TubeRadius, double, 0.0, 0.1);
  vtkGetMacro(TubeRadius, double);
  ///@}

protected:
  vtkStreamlineTubes() = default;
  ~vtkStreamlineTubes() override = default;

  int FillInputPortInformation(int port, vtkInformation* information) override;
  int RequestData(vtkInformation* request, vtkInformationVector** input,
                  vtkInformationVector* output) override;

private:
  vtkStreamlineTubes(const vtkStreamlineTubes&) = delete;
  void operator=(const vtkStreamlineTubes&) = delete;

  void Trace(vtkDataSet* field, vtkPolyData* lines) const;

  int NumberOfLines = 200;
  double LineLength = 0.2;
  double TubeRadius = 0.005;
};

#endif
